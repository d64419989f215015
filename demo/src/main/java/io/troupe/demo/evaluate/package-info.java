/** {@code troupe evaluate}: section 4 of the paper measured again, its claims beside what we find. */
@NullMarked
package io.troupe.demo.evaluate;

import org.jspecify.annotations.NullMarked;
