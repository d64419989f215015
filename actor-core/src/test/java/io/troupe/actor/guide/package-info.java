/** The samples of docs/guide/01-actors.md and of the README, each in a test of what the text states about it. */
@NullMarked
package io.troupe.actor.guide;

import org.jspecify.annotations.NullMarked;
