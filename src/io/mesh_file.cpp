#include "mesh_file.hpp"

#include <filesystem>

#ifdef TRAJET_ASSIMP_LIBRARY
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "shared_library.hpp"
#include "trajet/geom/vertex_joiner.hpp"
#endif

namespace trajet::detail {

#ifdef TRAJET_ASSIMP_LIBRARY
namespace {

/// What is called of assimp's interface in C.
struct Assimp {
  SharedLibrary library{TRAJET_ASSIMP_LIBRARY, "reads mesh files"};
  decltype(aiImportFile)* import = library.function<decltype(aiImportFile)>("aiImportFile");
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
  return {assimp().import(path.c_str(), aiProcess_Triangulate), assimp().release_scene};
}

/// Gathers the triangles of a file's parts, each where it stands: vertices in one place are one, and of normals,
/// colours and materials, by which readers of pictures keep them apart, nothing is copied.
class MeshGatherer {
 public:
  explicit MeshGatherer(const aiScene& scene) : scene_(scene) {}

  TriangleMesh gather() {
    add(*scene_.mRootNode, aiMatrix4x4());
    mesh_.vertices = joiner_.take_vertices();
    return std::move(mesh_);
  }

 private:
  void add(const aiNode& node, const aiMatrix4x4& from_parent) {
    const aiMatrix4x4 to_file = from_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], to_file);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], to_file);
  }

  void add(const aiMesh& part, const aiMatrix4x4& to_file) {
    const bool is_moved = !to_file.IsIdentity(), is_mirrored = to_file.Determinant() < 0.0F;
    std::vector<int> joined(part.mNumVertices, -1);  // indices of those that triangles have
    const auto corner = [&](unsigned vertex) {
      int& index = joined[vertex];
      if (index < 0) {
        const aiVector3D p = is_moved ? to_file * part.mVertices[vertex] : part.mVertices[vertex];
        index = joiner_.index({p.x, p.y, p.z});
      }
      return index;
    };
    mesh_.triangles.reserve(mesh_.triangles.size() + part.mNumFaces);
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // lines and points have no area
      const int a = corner(face.mIndices[0]), b = corner(face.mIndices[1]), c = corner(face.mIndices[2]);
      mesh_.triangles.push_back({a, is_mirrored ? c : b, is_mirrored ? b : c});
    }
  }

  const aiScene& scene_;
  VertexJoiner joiner_;
  TriangleMesh mesh_;
};

}  // namespace
#endif

TriangleMesh read_mesh(const TableReader& table) {
  const std::string name = table.text("file");
#ifdef TRAJET_ASSIMP_LIBRARY
  const std::filesystem::path path = std::filesystem::path(table.where().file.str()).parent_path() / name;
  const ScenePointer scene = import(path.string());
  if (scene == nullptr) throw FileError(table.where("file"), assimp().error_text());
  try {
    return MeshGatherer(*scene).gather();
  } catch (const std::domain_error& error) {
    throw InputError(table.where("file"), "'" + name + "': " + error.what());
  }
#else
  throw InputError(table.where("file"),
                   "this trajet was built without assimp (TRAJET_ASSIMP) and reads no mesh files: '" + name + "'");
#endif
}

}  // namespace trajet::detail
