// The text of a CSV capture into columns of numbers.
#pragma once

#include "capture/capture.hpp"
#include "capture/raw_table.hpp"

namespace servoid {

// Metadata, header and rows. With a map, the columns it names; without, every column must be known.
RawTable read_csv(const std::string& text, const std::string& path, const SignalMap* map,
                  const Progress& progress = {});

// Names and duplicates: what can be said about the columns before their rows are read.
void check_columns(const RawTable& table);

// The columns a map asks for, with their meaning. `available` are the file's own names.
std::vector<RawColumn> mapped_columns(const SignalMap& map,
                                      const std::vector<std::string>& available,
                                      const std::string& path);

} // namespace servoid
