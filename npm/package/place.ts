/// Files where node runs; in a browser fetch() reads what lies beside the module.

declare const process: { versions?: { node?: string } } | undefined;
const isNode = typeof process !== "undefined" && !!process.versions?.node;

interface NodeFiles {
  readFile(path: string | URL): Promise<Uint8Array>;
  readdir(path: string, options: { withFileTypes: true }): Promise<{ name: string; isDirectory(): boolean }[]>;
}
interface NodePaths {
  dirname(path: string): string;
  join(...parts: string[]): string;
  basename(path: string): string;
}
// Names that no bundler for browsers looks up.
const nodes = <Module>(name: string): Promise<Module> => import(/* @vite-ignore */ /* webpackIgnore: true */ `node:${name}`) as Promise<Module>;

export async function template(): Promise<string> {
  const place = new URL("report_template.html", import.meta.url);
  if (!isNode) return (await fetch(place)).text();
  const { readFile } = await nodes<NodeFiles>("fs/promises");
  return new TextDecoder().decode(await readFile(place));
}

/// The joint file and what lies in its folder and two folders below it: meshes are beside it. Only those that it names are read.
export async function filesBeside(jointFile: string | URL): Promise<Record<string, Blob>> {
  const [{ readFile, readdir }, paths, { fileURLToPath }] = await Promise.all([
    nodes<NodeFiles>("fs/promises"), nodes<NodePaths>("path"), nodes<{ fileURLToPath(url: string | URL): string }>("url"),
  ]);
  const path = typeof jointFile === "string" ? jointFile : fileURLToPath(jointFile), folder = paths.dirname(path);
  const lazily = (at: string) => ({ arrayBuffer: async () => new Uint8Array(await readFile(at)).buffer }) as Blob;
  const files: Record<string, Blob> = { [paths.basename(path)]: lazily(path) };
  const list = async (below: string, depth: number): Promise<void> => {
    for (const entry of await readdir(paths.join(folder, below), { withFileTypes: true })) {
      const at = below ? `${below}/${entry.name}` : entry.name;
      if (!entry.isDirectory()) files[at] ??= lazily(paths.join(folder, at));
      else if (depth > 0) await list(at, depth - 1);
    }
  };
  await list("", 2);
  return files;
}
