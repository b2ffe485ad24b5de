// One reader each, with what must hold of what it took: mostly that it is the same again when written and read.
#pragma once

#include <string_view>

namespace shadowbench::fuzz {

// read_scenes.cpp
void readScene(std::string_view input);
void readMeshParts(std::string_view input);  // of a .gltf, by name, with its buffers
void readGltfText(std::string_view input);   // of a scene, by its nodes
void readGltfBinary(std::string_view input); // the same of a .glb, and its meshes
void readSceneJson(std::string_view input);

// read_foreign.cpp
void readObj(std::string_view input);
void readPly(std::string_view input);
void readGltf(std::string_view input);
void readGlb(std::string_view input);
void readImage(std::string_view input);       // EXR, PNG or PFM, by its first bytes
void readMeshAnswer(std::string_view input);  // of a child that a file has taken over
void readPartsAnswer(std::string_view input); // likewise
void readImageAnswer(std::string_view input); // likewise

// read_records.cpp
void readResults(std::string_view input);
void readManifestLines(std::string_view input);
void readMeasuredCell(std::string_view input);
void readMergedFolder(std::string_view input); // a line of a manifest, and the cell's file
void readComparedRecords(std::string_view input);

// read_references.cpp
void readCacheEntry(std::string_view input); // without the checksum, which no change of bytes would get past
void readGoldenLock(std::string_view input);

// read_renderers.cpp
void readRendererList(std::string_view input);
void readTimingFile(std::string_view input);

// read_judgements.cpp
void readBounds(std::string_view input);
void readPolicyOfAProgram(std::string_view input);
void readClaimList(std::string_view input);
void readBehaviourList(std::string_view input);
void readPaperPages(std::string_view input);

// read_techniques.cpp
void readTechniqueDescription(std::string_view input);
void readTechniqueShader(std::string_view input); // with what it includes, before it is compiled
void readExpectationList(std::string_view input);

// read_words.cpp
void readWords(std::string_view input); // of the command line

} // namespace shadowbench::fuzz
