// The page: one HTML file with everything in it, styles, scripts and data; nothing is fetched.
#pragma once

#include "answers/json.hpp"

#include <string>

namespace servoid {

// A report: the page with its story in it. Cost: the text of the story, copied twice.
std::string report_page(const Json& story);

// The live page: it asks the studio for its story.
std::string studio_page();

} // namespace servoid
