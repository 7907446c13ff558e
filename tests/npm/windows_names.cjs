// Loaded before the command (node --require): files have the names that Windows gives them, on a drive Z that is the root here,
// and a name that Windows would not understand is none.
const fs = require("node:fs");

Object.defineProperty(process, "platform", { value: "win32" });
const cwd = process.cwd;
process.cwd = () => `Z:${cwd().replaceAll("/", "\\")}`;
const native = (path) => {
  if (typeof path !== "string" || path.includes("/node_modules/condyle/")) return path;  // node's own name of the package
  if (/^[/\\]/.test(path)) throw Object.assign(new Error(`not a name on Windows: ${path}`), { code: "ENOENT" });
  return path.replace(/^Z:/i, "").replaceAll("\\", "/");
};
for (const name of ["chmod", "lstat", "mkdir", "open", "readdir", "readlink", "rename", "rmdir", "stat", "symlink", "truncate", "unlink", "utimes"]) {
  const call = fs[`${name}Sync`];
  fs[`${name}Sync`] = (...values) => call(...values.map((value, i) => (i < (/rename|symlink/.test(name) ? 2 : 1) ? native(value) : value)));
}
