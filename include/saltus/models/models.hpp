// All ready scenes, each with what is known about its outcome.
#pragma once

#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/bouncing_ball_diagram.hpp"
#include "saltus/models/robertson.hpp"
#include "saltus/models/shelf.hpp"
#include "saltus/models/tutorial.hpp"
#include "saltus/models/van_der_pol.hpp"
