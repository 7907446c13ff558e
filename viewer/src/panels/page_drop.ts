import { lineOf } from "../core/error_line";
import type { NamedFile } from "../core/protocol";
import { warn } from "../messages";
import { words } from "../words";

/// A folder of more files than a joint has is one that was dropped by mistake.
const mostFiles = 5000;

/// A folder or file of a drop: its files, and what it is called.
interface Dropped {
  path: string;
  file: (() => Promise<File>) | null;
  below: () => Promise<Dropped[]>;
}

/// Files dropped anywhere on the page do not replace it: `taken` gets them, those of a folder with their paths in it.
export function catchDrops(taken: (files: NamedFile[]) => void, signal: AbortSignal): void {
  document.addEventListener("dragover", (event) => event.preventDefault(), { signal });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    // Both lists are empty once the event is over.
    const files = withNames(event.dataTransfer?.files ?? []), items = [...(event.dataTransfer?.items ?? [])].filter(({ kind }) => kind === "file");
    const take = (dropped: NamedFile[]) => {
      if (dropped.length && !signal.aborted) taken(dropped);
    };
    if (!items.some((item) => item.webkitGetAsEntry()?.isDirectory)) return take(files);
    Promise.all(items.map(droppedItem)).then(filesBelow).then(take).catch((error: unknown) => warn(lineOf(error)));
  }, { signal });
}

/// Files by their own names.
export function withNames(files: Iterable<File>): NamedFile[] {
  return [...files].map((file) => ({ path: file.name, file }));
}

async function filesBelow(dropped: Dropped[]): Promise<NamedFile[]> {
  const files: NamedFile[] = [], waiting = [...dropped];
  for (let next = waiting.shift(); next; next = waiting.shift()) {
    if (files.length + waiting.length > mostFiles) throw new Error(words.dropManyFiles(mostFiles));
    if (next.file) files.push({ path: next.path, file: await next.file() });
    else waiting.push(...(await next.below()));
  }
  return files;
}

/// To be called during the event. Browsers without handles have entries, which those with handles do not let pages read that were opened from disk.
function droppedItem(item: DataTransferItem & { getAsFileSystemHandle?: () => Promise<FileSystemHandle> }): Promise<Dropped> | Dropped {
  const handle = item.getAsFileSystemHandle?.();
  return handle ? handle.then((each) => ofHandle(each, each.name)) : ofEntry(item.webkitGetAsEntry()!);
}

function ofHandle(handle: FileSystemHandle, path: string): Dropped {
  const below = async () => {
    const all: Dropped[] = [];
    for await (const each of (handle as FileSystemDirectoryHandle & { values: () => AsyncIterable<FileSystemHandle> }).values())
      all.push(ofHandle(each, `${path}/${each.name}`));
    return all;
  };
  return { path, file: handle.kind === "file" ? () => (handle as FileSystemFileHandle).getFile() : null, below };
}

function ofEntry(entry: FileSystemEntry): Dropped {
  const file = () => new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
  const below = async () => {
    const reader = (entry as FileSystemDirectoryEntry).createReader(), all: Dropped[] = [];
    // A reader gives some at a time, at last none.
    for (;;) {
      const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
      if (some.length === 0) return all;
      all.push(...some.map(ofEntry));
    }
  };
  return { path: entry.fullPath.slice(1), file: entry.isFile ? file : null, below };
}
