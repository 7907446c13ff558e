// The functions of zlib/zlib.h, by those of pako that are given to the module. Bytes are inflated and deflated where they lie in its memory.
mergeInto(LibraryManager["library"], {
  $streams: "new Map()",
  $ran__deps: ["$streams"],
  $ran: function (at, run, flush) {
    var stream = streams.get(at), fields = HEAPU32.subarray(at >> 2, (at >> 2) + 4);
    stream.input = stream.output = HEAPU8;
    [stream.next_in, stream.avail_in, stream.next_out, stream.avail_out] = fields;
    var result = run(stream, flush);
    fields.set([stream.next_in, stream.avail_in, stream.next_out, stream.avail_out]);
    return result;
  },
  inflateInit2__deps: ["$streams"],
  inflateInit2: function (at, windowBits) {
    var stream = new Module["zlib"].ZStream();
    streams.set(at, stream);
    return Module["zlib"].zlibInflateInit2(stream, windowBits);
  },
  inflate__deps: ["$ran"],
  inflate: function (at, flush) {
    return ran(at, Module["zlib"].zlibInflate, flush);
  },
  inflateReset__deps: ["$streams"],
  inflateReset: function (at) {
    return Module["zlib"].zlibInflateReset(streams.get(at));
  },
  inflateEnd__deps: ["$streams"],
  inflateEnd: function (at) {
    var stream = streams.get(at);
    streams.delete(at);
    return Module["zlib"].zlibInflateEnd(stream);
  },
  deflateInit2__deps: ["$streams"],
  deflateInit2: function (at, level, method, windowBits, memory, strategy) {
    var stream = new Module["zlib"].ZStream();
    streams.set(at, stream);
    // The last one: bytes are hashed as zlib does it, so that what is deflated has the bytes of zlib.
    return Module["zlib"].zlibDeflateInit2(stream, level, method, windowBits, memory, strategy, true);
  },
  deflate__deps: ["$ran"],
  deflate: function (at, flush) {
    return ran(at, Module["zlib"].zlibDeflate, flush);
  },
  deflateEnd__deps: ["$streams"],
  deflateEnd: function (at) {
    var stream = streams.get(at);
    streams.delete(at);
    return Module["zlib"].zlibDeflateEnd(stream);
  },
});
