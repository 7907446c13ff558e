#include "condyle/io/version.hpp"
