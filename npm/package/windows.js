// Windows' names of files as the command has them, which knows POSIX: "Z:\hips\a.toml" is "/Z:/hips/a.toml" within.
const onWindows = process.platform === "win32";

const within = (path) => path.replaceAll("\\", "/").replace(/^[A-Za-z]:(?=\/|$)/, "/$&");
export const outside = onWindows ? (path) => path.replace(/^\/([A-Za-z]:)(\/|$)/, "$1/") : (path) => path;

const text = "^--(case|date|note|title)", givenText = new RegExp(`${text}=`), beforeText = new RegExp(`${text}$`);

/// A word of the command line; of an option with a value, its value. A text that is only printed stays.
export const wordWithin = (word, i, words) => (!onWindows || givenText.test(word) || beforeText.test(words[i - 1]) ? word
  : word.replace(/^(--[\w-]+=|)(.*)$/s, (_, option, value) => option + within(value)));

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
