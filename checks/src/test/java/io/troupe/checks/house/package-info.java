/** Figures about the sources: sizes, names and the language of comments, with the limits that they keep. */
@NullMarked
package io.troupe.checks.house;

import org.jspecify.annotations.NullMarked;
