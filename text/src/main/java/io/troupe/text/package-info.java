/** Texts for error messages: suggestions for misspelled names. */
@NullMarked
package io.troupe.text;

import org.jspecify.annotations.NullMarked;
