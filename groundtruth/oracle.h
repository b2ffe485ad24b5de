// Computes references: chooses the oracle that can answer a request, and asks it.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"
#include "groundtruth/contract/reference_key.h"
#include "groundtruth/store/cache.h"

#include <set>
#include <string>

namespace shadowbench::groundtruth {

/// Computes a reference, without looking at a cache. Visibility is 0 off the receivers. With an explicit `Polygon` or
/// `Plan`, receivers that are not planar (horizontal) become OnEdge: there is no label for them. Throws BadInput for an
/// oracle that cannot answer for this light or scene (`Polygon` with no planar receiver), Inconclusive if a tool is missing
/// or fails, its render is not certified or two exact oracles contradict each other, InternalError if two oracles see
/// different geometry.
Reference compute(const Request& request, const Progress& progress = {});

/// Versions of all that decides the reference's numbers. Throws Inconclusive if POV-Ray is needed and missing.
Tools toolVersions(const Request& request);

/// The hash of the sources that compute the request's reference, which names its entry in the cache and is no part of its
/// key: records stay comparable where the numbers are the same, and no number is kept that these sources have not computed.
std::string sourcesOf(const Request& request);
std::set<std::string> allSources(); // of any request

/// The key of a request's reference, the versions that it is made of and the hash of the sources that compute it.
struct ReferenceKey {
    std::string text; // groundtruth/contract/reference_key.h
    Tools tools;
    std::string sources;
};

/// Hashes every mesh of the request: to be made once and passed on. Throws Inconclusive if a tool whose version it needs is
/// missing.
ReferenceKey referenceKey(const Request& request);
std::string key(const Request& request); // its text

/// The reference that `cache` keeps, else `compute` and `store`, in one process at a time; a cache that cannot be written
/// costs a warning, not the run.
Reference cached(const Cache& cache, const Request& request, const Progress& progress = {});

/// The same for a request whose key is known.
Reference cached(const Cache& cache, const Request& request, const ReferenceKey& key, const Progress& progress = {});

} // namespace shadowbench::groundtruth
