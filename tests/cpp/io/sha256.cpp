/// SHA-256 of known texts (FIPS 180-4; NIST's example values).

#include "hydrodae/io/sha256.h"

#include <doctest/doctest.h>

using hydrodae::io::sha256_of_text;

TEST_CASE("digests of the standard's examples, by either way") {
  for (const bool fast : {true, false}) {
    CAPTURE(fast);
    const auto digest = [&](const std::string& text) { return sha256_of_text(text, fast); };
    CHECK(digest("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(digest("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(digest(std::string(1000000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  }
}
