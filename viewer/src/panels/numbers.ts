import { html, section, spaced } from "../dom";
import { limitText } from "../plots/limits";
import type { MeshSource, ReportText } from "../report";
import { words } from "../words";

function filesOf(mesh: MeshSource | { files: MeshSource[] }): MeshSource[] {
  return "files" in mesh ? mesh.files : [mesh];
}

function table(head: readonly string[], rows: readonly (readonly string[])[], caption: string): HTMLElement {
  return html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    html("table", {}, html("caption", {}, caption),
      html("thead", {}, html("tr", {}, ...head.map((text) => html("th", { scope: "col" }, text)))),
      html("tbody", {}, ...rows.map(([first, ...cells]) =>
        html("tr", {}, html("th", { scope: "row" }, first!), ...cells.map((cell) => html("td", {}, cell)))))));
}

/// All numbers of the report with their units, where they come from, and what they are not.
export function numbersPanel(report: ReportText, counts: { fixed: [number, number]; mobile: [number, number] }): HTMLElement {
  const { joint, rom } = report;
  const parts: HTMLElement[] = [
    table(["", words.vertices, words.triangles],
      (["fixed", "mobile"] as const).map((body) => [joint[body], ...counts[body].map(String)]), `${words.kind}: ${joint.kind}, ${words.side}: ${joint.side}`),
  ];
  if (rom) {
    const degrees = (value: number | null) => (value === null ? "–" : `${value.toFixed(1)}°`);
    parts.push(
      table(["", words.limit, words.reason, words.contactKind, words.bearingContact, words.normal],
        rom.motions.map((m) => [
          spaced(m.name), limitText(m), words.reasons[m.reason], m.contact_kind ?? "–", degrees(m.bearing_contact_deg),
          degrees(m.normal_range_deg),
        ]), words.limits),
      html("h3", {}, words.notes),
      rom.notes.length ? html("ul", {}, ...rom.notes.map(({ code, text }) => html("li", {}, `${text} (${code})`)))
        : html("p", {}, words.noNotes));
    if (rom.terms.length)
      parts.push(html("h3", {}, words.terms), html("ul", {}, ...rom.terms.map((term) => html("li", {}, term))));
    if (!rom.motions.some((m) => m.band)) parts.push(html("p", {}, words.noBand));
    if (rom.provenance) {
      const { provenance } = rom;
      const files = [provenance.joint_file, ...filesOf(provenance.fixed_mesh), ...filesOf(provenance.mobile_mesh)];
      parts.push(
        table([words.file, words.bytes, words.sha256], files.map(({ path, bytes, sha256 }) => [path, String(bytes), sha256]),
          `${words.made} condyle ${provenance.version}, ${words.command}: ${provenance.command.join(" ")}`));
    }
  } else {
    parts.push(html("p", { class: "warning" }, words.noLimits + (report.rom_error ?? "")));
  }
  return section(words.numbers, ...parts, html("p", {}, words.scope));
}
