/** Assertions for unit tests of wirings; they need AssertJ, which nothing else here does. */
@NullMarked
package io.troupe.petri.testkit;

import org.jspecify.annotations.NullMarked;
