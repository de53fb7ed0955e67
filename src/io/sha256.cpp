#include "io/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"

namespace credo {
namespace {

class Sha256 {
public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(std::span<unsigned char const> bytes) {
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    std::string text;
    for (unsigned char const byte : std::span(digest).first(size)) {
      constexpr char const* kDigits = "0123456789abcdef";
      text += {kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
    return text;
  }

private:
  static void check(bool done) {
    if (!done) {
      throw std::runtime_error("libcrypto does not make a SHA-256");
    }
  }

  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

}  // namespace

std::string sha256_of(std::span<unsigned char const> bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.hex();
}

std::string sha256_of_file(std::filesystem::path const& path) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  std::vector<unsigned char> piece(kPiece);
  std::ifstream file(path, std::ios::binary);
  Sha256 sum;
  while (file) {
    file.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(kPiece));
    sum.add(std::span(piece).first(static_cast<std::size_t>(file.gcount())));
  }
  if (!file.eof()) {
    throw InputError(path.string() + ": cannot be read");
  }
  return sum.hex();
}

}  // namespace credo
