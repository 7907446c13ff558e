#pragma once

#include "condyle/contact.hpp"

struct condyle_joint_contact {
  condyle::contact::JointContact joint;
};
