/** What the documentation says is what the build compiles and runs. */
@NullMarked
package io.troupe.checks.docs;

import org.jspecify.annotations.NullMarked;
