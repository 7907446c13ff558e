#include "io/file/deflate.hpp"

#include <zlib.h>

#include <new>

namespace condyle::io {

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  // Given that much room, memory of its own is all that zlib can lack.
  if (compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               bytes.size()) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

}  // namespace condyle::io
