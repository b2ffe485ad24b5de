// References as bytes (an entry of the cache) and as files to look at (`shadowbench reference --out`).
#pragma once

#include "groundtruth/contract/reference.h"

#include <filesystem>
#include <string_view>

namespace shadowbench::groundtruth {

/// One line of JSON (format version, key, size, provenance), the images as little-endian arrays, and the XXH3-64 of all
/// before.
std::string encode(const Reference& reference);

/// The inverse. Throws BadInput saying what is wrong (too short, checksum, version, another key, sizes) with damaged bytes.
Reference decode(std::string_view bytes, std::string_view key);

/// The first line of an entry.
struct EntryHeader {
    std::string key;
    int width = 0, height = 0; // pixels
    Provenance provenance;
};

/// The header of `bytes`, an entry or as much of one as holds its first line. Throws BadInput as `decode` does; the checksum
/// is not looked at.
EntryHeader decodeHeader(std::string_view bytes);

/// The provenance as JSON text, indented, ending in a new line.
std::string provenanceJson(const Provenance& provenance);

/// Writes `visibility.exr` (float channels V, sigma, mask: 1 at scored receivers, else 0, and edge_distance in pixels,
/// infinity where there is none) and `provenance.json` into `folder`. Throws InternalError when a file cannot be written.
void writeReference(const Reference& reference, const std::filesystem::path& folder);

} // namespace shadowbench::groundtruth
