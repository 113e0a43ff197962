// A consumer of digests alone.
#include <scarf/digest/digest.h>

#include "check.h"

int main() {
  scarf::Digest digest;
  CHECK(digest.hex() == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
