import { fold, html, textOf } from "../dom";
import { bytesOf, inflated } from "../packed";
import { words } from "../words";

/// Licences of what the page is made of, in full once they are requested.
export function licencesFold(): HTMLDetailsElement {
  const licences = html("pre", { id: "licences", tabindex: 0 });
  const made = fold(words.licences, false, licences);
  made.addEventListener("toggle", () => void showLicences(licences), { once: true });
  return made;
}

async function showLicences(place: HTMLElement): Promise<void> {
  const texts = new TextDecoder().decode(await inflated(bytesOf(textOf("licence-texts") ?? ""), "gzip"));
  place.textContent = `${textOf("licence-list") ?? ""}\n\n${texts}`;
}
