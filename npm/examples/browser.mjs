// A module of a page: the files that its user chose, the joint file among them, and their limits as a list in the page.
import { rangeOfMotion, readJoint } from "condyle";

export async function showLimits(files, list) {
  const joint = await readJoint(Object.fromEntries([...files].map((file) => [file.webkitRelativePath || file.name, file])));
  for (const { name, limit_deg, reason } of rangeOfMotion(joint).motions) {
    const item = document.createElement("li");
    item.textContent = `${name.replaceAll("_", " ")}: ${reason === "contact" ? "" : "over "}${limit_deg.toFixed(1)}°`;
    list.append(item);
  }
}
