// Mechanics for scalars of one's own: members of its class templates, which the library compiles for its scalars only
// (scalars.hpp).
#pragma once

#include "mechanics/algebra_members.hpp"
#include "mechanics/bodies_members.hpp"
#include "mechanics/element_members.hpp"
#include "mechanics/equations/system_members.hpp"
#include "mechanics/joint_members.hpp"
#include "mechanics/rotation_members.hpp"
#include "mechanics/springs_members.hpp"
