// What the command asks of node: npm/src. Functions are by the worker that runs it (worker.js) in Module.node.
mergeInto(LibraryManager["library"], {
  condyle_signalled: function () {
    return Module["node"].signalled();
  },
  condyle_watch: function (begins) {
    Module["node"].watch(begins !== 0);
  },
  condyle_run: function (words, bytes, showsErrors) {
    return Module["node"].run(UTF8ToString(words, bytes), showsErrors !== 0);
  },
  condyle_template_size: function () {
    return Module["node"].template().length;
  },
  condyle_template_read: function (bytes) {
    HEAPU8.set(Module["node"].template(), bytes);
  },
});
