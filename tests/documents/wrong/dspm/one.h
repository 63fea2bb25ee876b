// docs/page.md is there.
// docs/lost.md is not.
#pragma once
