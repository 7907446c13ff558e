// Windows' names of files as the command has them, which knows POSIX: "Z:\hips\a.toml" is "/Z:/hips/a.toml" within.
const onWindows = process.platform === "win32";

const within = (path) => path.replaceAll("\\", "/").replace(/^[A-Za-z]:(?=\/|$)/, "/$&");
export const outside = onWindows ? (path) => path.replace(/^\/([A-Za-z]:)(\/|$)/, "$1/") : (path) => path;

/// A word of the command line: of an option with a value, the value.
export const wordWithin = onWindows ? (word) => word.replace(/^(--[\w-]+=|)(.*)$/s, (_, option, value) => option + within(value)) : (word) => word;

/// Has emscripten's files take and give names as they are within.
export function nameFilesOf(FS) {
  if (!onWindows) return;
  for (const name of ["lookupPath", "chdir", "mknod", "mkdir", "symlink", "rename", "rmdir", "readdir", "unlink", "readlink", "stat", "lstat", "chmod", "chown", "truncate", "utime", "open"]) {
    const call = FS[name];
    FS[name] = (...values) => call(...values.map((value) => (typeof value === "string" ? outside(value) : value)));
  }
  const { cwd, readlink } = FS;
  FS.cwd = () => within(cwd());
  FS.readlink = (path) => within(readlink(path));
}
