// DBC files in memory, for the tests of their reader.
#pragma once

#include "can/dbc.hpp"
#include "common/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace servoid::can {

// Every section that a DBC has, and strings that look like sections.
inline const std::string whole_file = R"(VERSION "1.0 // no comment; BO_ 1 No: 8 X"

NS_ :
	NS_DESC_
	CM_
	BA_DEF_
	BA_
	VAL_
	CAT_DEF_
	CAT_
	FILTER
	BA_DEF_DEF_
	EV_DATA_
	ENVVAR_DATA_
	SGTYPE_
	SGTYPE_VAL_
	BA_DEF_SGTYPE_
	BA_SGTYPE_
	SIG_TYPE_REF_
	VAL_TABLE_
	SIG_GROUP_
	SIG_VALTYPE_
	SIGTYPE_VALTYPE_
	BO_TX_BU_
	BA_DEF_REL_
	BA_REL_
	BA_DEF_DEF_REL_
	BU_SG_REL_
	BU_EV_REL_
	BU_BO_REL_
	SG_MUL_VAL_

BS_: 500 : 1,2

BU_: Drive Master
VAL_TABLE_ States 1 "BO_ 7 On: 8 X" 0 "Off" ;

BO_ 385 DriveStatus: 8 Drive
 SG_ Position : 0|32@1- (0.0001,-5) [-1E+30|1.5e3] "rad"  Master,Other
 SG_ Torque : 39|16@0- (0.01,0) [0|0] "Nm" Master
 SG_ State : 48|4@1+ (1,0) [0|15] "" Vector__XXX

BO_ 2566834709 Extended: 64 Vector__XXX
 SG_ Single : 0|32@1- (1,0) [0|0] "" Vector__XXX
 SG_ Double : 39|64@0- (1,0) [0|0] "" Vector__XXX

BO_ 512 Muxed: 8 Drive
 SG_ Selector M : 0|8@1+ (1,0) [0|0] "" Master
 SG_ First m0 : 8|8@1+ (1,0) [0|0] "" Master
 SG_ Inner m12M : 8|8@1+ (1,0) [0|0] "" Master

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Orphan : 0|8@1+ (1,0) [0|0] "" Vector__XXX

BO_TX_BU_ 385 : Drive,Master;
EV_ Environment: 0 [0|1] "BO_" 0 2 DUMMY_NODE_VECTOR0 Drive;
ENVVAR_DATA_ Environment: 5;
CM_ "SG_ about nothing";
CM_ BO_ 385 "several lines:
BO_ 385 Twice: 8 X
 SG_ Position : 900|32@1- (1,0) [0|0] \"\" X
SIG_VALTYPE_ 385 Position : 2;
";
CM_ SG_ 385 Position "a quote: \"; BO_ 5 A: 8 X\" // still inside";
CM_ BU_ Drive "";
BA_DEF_ BO_  "GenMsgCycleTime" INT 0 65535;
BA_DEF_ "BusType" STRING ;
BA_DEF_DEF_  "GenMsgCycleTime" 0;
BA_ "BusType" "CAN FD";
BA_ "GenMsgCycleTime" BO_ 385 1;
BA_ "GenSigStartValue" SG_ 385 State 3;
BA_REL_ "Rel" BU_SG_REL_ Drive SG_ 385 State 1;
VAL_ 385 State 1 "On" 0 "SG_ Off : ;" ;
SIG_GROUP_ 385 Group 1 : Position Torque;
SIG_VALTYPE_ 2566834709 Single : 1;
SIG_VALTYPE_ 2566834709 Double : 2;
SIG_VALTYPE_ 385 State : 0;
SIG_VALTYPE_ 3221225472 Orphan : 1;
SG_MUL_VAL_ 512 First Selector 0-0, 3-5;
)";

inline Dbc parse(const std::string& text) { return parse_dbc(text, "a.dbc"); }

inline std::string error_of(const std::string& text) {
    try {
        parse(text);
        return "no error";
    } catch (const FileError& error) {
        return error.what();
    }
}

inline std::string search_error(const std::string& name, const std::string& text = whole_file) {
    try {
        find_signal(parse(text), name);
        return "no error";
    } catch (const FileError& error) {
        return error.what();
    }
}

// A file with one message of 8 bytes; `signals` are lines 2 and following.
inline std::string message_with(const std::string& signals) { return "BO_ 385 A: 8 X\n" + signals; }

inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), by);
}

inline const std::string good_signal = " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n";

} // namespace servoid::can
