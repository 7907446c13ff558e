// What both threads see: whether a signal came, whether the work looks for one, and the folders that it has made.

/// Places of numbers.
export const written = { signalled: 0, watched: 1, folderBytes: 2 };
const numberBytes = 16, textBytes = 1 << 16;

export const sharedMemory = () => new SharedArrayBuffer(numberBytes + textBytes);
export const state = (shared) => new Int32Array(shared, 0, numberBytes / 4);

/// A set of paths, of which the last that do not fit are left out: a signal then leaves an empty folder.
export function folders(shared) {
  const at = state(shared), text = new Uint8Array(shared, numberBytes), paths = new Set();
  const write = () => {
    const bytes = new TextEncoder().encode(JSON.stringify([...paths]));
    if (bytes.length > text.length) return;
    text.set(bytes);
    Atomics.store(at, written.folderBytes, bytes.length);
  };
  return {
    add: (path) => (paths.add(path), write()),
    delete: (path) => (paths.delete(path), write()),
    read: () => JSON.parse(new TextDecoder().decode(text.slice(0, Atomics.load(at, written.folderBytes))) || "[]"),
  };
}
