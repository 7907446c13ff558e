import { html } from "./dom";

/// Offers bytes as a file, from memory.
export function saveBlob(name: string, blob: Blob): void {
  const url = URL.createObjectURL(blob);
  html("a", { href: url, download: name }).click();
  URL.revokeObjectURL(url);
}

export function save(name: string, type: string, text: string): void {
  saveBlob(name, new Blob([text], { type }));
}

/// Lines of cells as CSV; cells with a comma, a quote or a line break are quoted.
export function csv(rows: readonly (readonly (string | number | null)[])[]): string {
  const cell = (value: string | number | null) => {
    const text = value === null ? "" : String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return rows.map((row) => row.map(cell).join(",")).join("\n") + "\n";
}
