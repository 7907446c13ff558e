#include <cstdio>

bool writes_jam_file();

int main() {
  std::puts(writes_jam_file() ? "a file of OpenSim-JAM" : "no file");
}
