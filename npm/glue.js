// What the command asks of node: npm/src. Functions are by the worker that runs it (worker.js) in Module.node.
mergeInto(LibraryManager["library"], {
  condyle_signalled: function () {
    return Module["node"].signalled();
  },
  condyle_watch: function (begins) {
    Module["node"].watch(begins !== 0);
  },
  condyle_run: function (words, bytes, showsErrors) {
    // Words have a 0 after each, where UTF8ToString() ends.
    return Module["node"].run(new TextDecoder().decode(HEAPU8.slice(words >>> 0, (words >>> 0) + bytes)), showsErrors !== 0);
  },
  condyle_hash_begin: function () {
    return Module["node"].hashBegin();
  },
  condyle_hash_add: function (hash, bytes, size) {
    Module["node"].hash(hash).update(HEAPU8.subarray(bytes >>> 0, (bytes >>> 0) + (size >>> 0)));
  },
  condyle_hash_digits: function (hash, digits) {
    stringToUTF8Array(Module["node"].hash(hash).copy().digest("hex"), HEAPU8, digits, 65);
  },
  condyle_template_size: function () {
    return Module["node"].template().length;
  },
  condyle_template_read: function (bytes) {
    HEAPU8.set(Module["node"].template(), bytes);
  },
});
