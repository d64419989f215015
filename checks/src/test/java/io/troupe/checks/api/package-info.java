/** Checks of actor-core's API: its size, its pages, and a test for each point of its contract. */
@NullMarked
package io.troupe.checks.api;

import org.jspecify.annotations.NullMarked;
