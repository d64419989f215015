/** For unit tests: assertions about wirings, which need AssertJ, and actors that are followed, which need JUnit 5. */
@NullMarked
package io.troupe.petri.testkit;

import org.jspecify.annotations.NullMarked;
