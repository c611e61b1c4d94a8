// Which parameters of a law enter it linearly.
//
// A fit solves for those at once, whatever value they start at; only the others are searched.
#pragma once

#include <string>
#include <vector>

namespace servoid {

// law = Σ linear_i·column_i(shapes) + rest(shapes)
struct LawParts {
    std::vector<std::string> linear, shapes; // each in the order of the alphabet
    bool rest = true;                        // false: the law is 0 where all linear ones are 0
};

// Found by trying: the law is evaluated along straight lines between random values of the
// parameters, at random t theta v a T of all sizes and signs. The values of a model do not enter,
// so a parameter does not change its kind while it is fitted. Where several sets are possible
// (k·(theta − x)), a parameter that takes the whole law to zero comes first. `law` must be free of
// faults (find_fault). Kept by law for each thread: the reference stays valid in it.
const LawParts& parts_of(const std::string& law, const std::vector<std::string>& parameters);

} // namespace servoid
