/** What actor-core promises: the size of its public API, and a test for each point of its contract. */
@NullMarked
package io.troupe.checks.api;

import org.jspecify.annotations.NullMarked;
