// A shared library of the user's with condyle::io inside, HDF5 among it.
#include <condyle/io/jam_file.hpp>

bool writes_jam_file() {
  const double times_s[] = {0, 0.5};
  condyle::io::write_jam_file("knee.h5", times_s, {});
  return std::filesystem::file_size("knee.h5") > 0;
}
