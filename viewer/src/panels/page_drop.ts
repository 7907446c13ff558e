import { lineOf } from "../core/error_line";
import type { NamedFile } from "../core/protocol";
import { warn } from "../messages";
import { words } from "../words";

/// A folder of more files than a joint has is one that was dropped by mistake.
const mostFiles = 5000;

/// Files dropped anywhere on the page do not replace it: `taken` gets them, those of a folder with their paths in it.
export function catchDrops(taken: (files: NamedFile[]) => void, signal: AbortSignal): void {
  document.addEventListener("dragover", (event) => event.preventDefault(), { signal });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    // Both lists are empty once the event is over.
    const files = withNames(event.dataTransfer?.files ?? []);
    const entries = [...(event.dataTransfer?.items ?? [])].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
    const take = (dropped: NamedFile[]) => {
      if (dropped.length && !signal.aborted) taken(dropped);
    };
    if (!entries.some(({ isDirectory }) => isDirectory)) return take(files);
    filesBelow(entries).then(take).catch((error: unknown) => warn(lineOf(error)));
  }, { signal });
}

/// Files by their own names.
export function withNames(files: Iterable<File>): NamedFile[] {
  return [...files].map((file) => ({ path: file.name, file }));
}

async function filesBelow(entries: FileSystemEntry[]): Promise<NamedFile[]> {
  const files: NamedFile[] = [], waiting = [...entries];
  for (let entry = waiting.shift(); entry; entry = waiting.shift()) {
    if (files.length + waiting.length > mostFiles) throw new Error(words.dropManyFiles(mostFiles));
    if (entry.isDirectory) waiting.push(...(await entriesIn(entry as FileSystemDirectoryEntry)));
    else files.push({ path: entry.fullPath.slice(1), file: await fileOf(entry as FileSystemFileEntry) });
  }
  return files;
}

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((resolve, reject) => entry.file(resolve, reject));
}

/// A reader gives some at a time, at last none.
async function entriesIn(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader(), all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return all;
    all.push(...some);
  }
}
