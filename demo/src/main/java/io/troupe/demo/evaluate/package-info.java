/**
 * {@code troupe evaluate}: repeats the measurements of section 4 of the paper and compares its claims with the results.
 */
@NullMarked
package io.troupe.demo.evaluate;

import org.jspecify.annotations.NullMarked;
