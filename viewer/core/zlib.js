// The functions of zlib/zlib.h, by those of pako that the page gives to the module. Bytes are inflated where they lie in its memory.
mergeInto(LibraryManager.library, {
  $streams: "new Map()",
  inflateInit2__deps: ["$streams"],
  inflateInit2: function (at, windowBits) {
    var stream = new Module["zlib"].ZStream();
    streams.set(at, stream);
    return Module["zlib"].zlibInflateInit2(stream, windowBits);
  },
  inflate__deps: ["$streams"],
  inflate: function (at, flush) {
    var stream = streams.get(at), fields = HEAPU32.subarray(at >> 2, (at >> 2) + 4);
    stream.input = stream.output = HEAPU8;
    [stream.next_in, stream.avail_in, stream.next_out, stream.avail_out] = fields;
    var result = Module["zlib"].zlibInflate(stream, flush);
    fields.set([stream.next_in, stream.avail_in, stream.next_out, stream.avail_out]);
    return result;
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
});
