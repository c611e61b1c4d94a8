/// servoid: the firmware core. Everything a drive needs; sid_hal.h is the porting manual.
#ifndef SERVOID_SERVOID_H
#define SERVOID_SERVOID_H

#include "servoid/sid_bin.h"
#include "servoid/sid_can.h"
#include "servoid/sid_excite.h"
#include "servoid/sid_fixed.h"
#include "servoid/sid_friction.h"
#include "servoid/sid_hal.h"
#include "servoid/sid_identify.h"
#include "servoid/sid_inertia.h"
#include "servoid/sid_loop.h"
#include "servoid/sid_node.h"
#include "servoid/sid_osc.h"
#include "servoid/sid_scaled.h"
#include "servoid/sid_sdo.h"
#include "servoid/sid_stream.h"
#include "servoid/sid_telemetry.h"
#include "servoid/sid_version.h"

#endif
