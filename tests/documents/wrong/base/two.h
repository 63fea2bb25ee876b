// One of the headers.

struct Two {};
