// Holds the precompiled headers (CMakeLists.txt: scree_headers); there is nothing to compile here.
namespace scree
{
}
