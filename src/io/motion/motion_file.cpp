#include "condyle/io/recorded_motion.hpp"
#include "io/file/whole_file.hpp"
#include "io/motion/motion_table.hpp"

namespace condyle::io {

MotionTable read_motion_table(const std::filesystem::path& path) {
  io::check_is_file(path);
  io::is_of_opensim(path);
  return io::motion_table_of(io::read_whole_file(path), path);
}

}  // namespace condyle::io
