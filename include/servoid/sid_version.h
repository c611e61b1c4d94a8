/// servoid: version of the firmware core.
#ifndef SERVOID_SID_VERSION_H
#define SERVOID_SID_VERSION_H

#define SID_VERSION_MAJOR 0
#define SID_VERSION_MINOR 1
#define SID_VERSION_PATCH 0
#define SID_VERSION_STRING "0.1.0"

#endif
