// Which parameters stand for which cause: the same row without it.
#pragma once

#include "studies/causes/cause.h"
#include "techniques/contract/entry.h"

#include <optional>
#include <string>

namespace shadowbench::causes {

using techniques::Entry;
using techniques::Parameters;

/// Each gives the row without one cause; nothing where the row has no such parameter, or it is at its limit. What is set
/// need not be of a parameter's domain: a bias that stays what it is over finer texels is more of them.

/// With casters behind the eye.
std::optional<Parameters> withAllCasters(const Entry& entry, const Parameters& row);

/// Its filter as small as it can be.
std::optional<Parameters> withLeastFilter(const Entry& entry, const Parameters& row);

/// A bias of at least the technique's own kind and size.
std::optional<Parameters> withEnoughBias(const Entry& entry, const Parameters& row);

/// Texels as fine as a technique of its kind can have them and a frame still takes about a second; the bias in the world
/// stays.
std::optional<Parameters> withFineTexels(const Entry& entry, const Parameters& row);

/// The technique's own bias, of the row's kind where that offsets receivers.
std::optional<Parameters> withOwnBias(const Entry& entry, const Parameters& row);

/// A quarter of the bias; of variances, whose least value hides as much of a shadow at a contact, that of a quarter of it.
std::optional<Parameters> withLessBias(const Entry& entry, const Parameters& row);

/// More samples of the light, or more taps.
std::optional<Parameters> withMoreSamples(const Entry& entry, const Parameters& row);

/// What to change of the row first against the cause: "map=2048"; "" where no parameter does.
std::string changeAgainst(Cause cause, const Entry& entry, const Parameters& row);

} // namespace shadowbench::causes
