#include "mesh_file.hpp"

#include <filesystem>

#ifdef TRAJET_ASSIMP_LIBRARY
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <memory>

#include "shared_library.hpp"
#endif

namespace trajet::detail {

#ifdef TRAJET_ASSIMP_LIBRARY
namespace {

/// What is called of assimp's interface in C.
struct Assimp {
  SharedLibrary library{TRAJET_ASSIMP_LIBRARY, "reads mesh files"};
  decltype(aiCreatePropertyStore)* create_settings =
      library.function<decltype(aiCreatePropertyStore)>("aiCreatePropertyStore");
  decltype(aiReleasePropertyStore)* release_settings =
      library.function<decltype(aiReleasePropertyStore)>("aiReleasePropertyStore");
  decltype(aiSetImportPropertyInteger)* set_integer =
      library.function<decltype(aiSetImportPropertyInteger)>("aiSetImportPropertyInteger");
  decltype(aiImportFileExWithProperties)* import =
      library.function<decltype(aiImportFileExWithProperties)>("aiImportFileExWithProperties");
  decltype(aiReleaseImport)* release_scene = library.function<decltype(aiReleaseImport)>("aiReleaseImport");
  decltype(aiGetErrorString)* error_text = library.function<decltype(aiGetErrorString)>("aiGetErrorString");
};

const Assimp& assimp() {
  static const Assimp functions;
  return functions;
}

using ScenePointer = std::unique_ptr<const aiScene, decltype(aiReleaseImport)*>;

/// nullptr if it cannot be read.
ScenePointer import(const std::string& path) {
  const std::unique_ptr<aiPropertyStore, decltype(aiReleasePropertyStore)*> settings(assimp().create_settings(),
                                                                                     assimp().release_settings);
  // lines and points have no volume
  assimp().set_integer(settings.get(), AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  return {assimp().import(path.c_str(),
                          aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                              aiProcess_PreTransformVertices,
                          nullptr, settings.get()),
          assimp().release_scene};
}

}  // namespace
#endif

TriangleMesh read_mesh(const TableReader& table) {
  const std::string name = table.text("file");
#ifdef TRAJET_ASSIMP_LIBRARY
  const std::filesystem::path path = std::filesystem::path(table.where().file.str()).parent_path() / name;
  const ScenePointer scene = import(path.string());
  if (scene == nullptr) throw FileError(table.where("file"), assimp().error_text());
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = static_cast<int>(mesh.vertices.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i)
      mesh.vertices.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      const auto corner = [&](unsigned k) { return first + static_cast<int>(face.mIndices[k]); };
      if (face.mNumIndices == 3) mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
  return mesh;
#else
  throw InputError(table.where("file"),
                   "this trajet was built without assimp (TRAJET_ASSIMP) and reads no mesh files: '" + name + "'");
#endif
}

}  // namespace trajet::detail
