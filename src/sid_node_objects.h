// The node's objects (SPEC.md, "Objects"). Private to sid_node.c.
#ifndef SERVOID_SID_NODE_OBJECTS_H
#define SERVOID_SID_NODE_OBJECTS_H

#include "servoid/sid_node.h"

// Both return an abort code; a read fills in value and size.
uint32_t sid_node_read(const sid_node_t* node, sid_sdo_t* sdo);
uint32_t sid_node_write(sid_node_t* node, const sid_sdo_t* sdo);

// What a write can set off (sid_node.c).
uint32_t sid_node_start(sid_node_t* node, uint32_t run_number);
uint32_t sid_node_prepare(sid_node_t* node, uint32_t length);
void sid_node_abort(sid_node_t* node);
void sid_node_set_times(sid_node_t* node);

#endif
