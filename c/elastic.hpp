#pragma once

#include "condyle/pressure.hpp"

struct condyle_elastic_contact {
  condyle::contact::ElasticContact contact;
};
