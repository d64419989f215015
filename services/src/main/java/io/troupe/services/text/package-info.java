/** Texts for error messages: suggestions for misspelled names. */
@NullMarked
package io.troupe.services.text;

import org.jspecify.annotations.NullMarked;
