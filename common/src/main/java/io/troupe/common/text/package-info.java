/**
 * Reading of text: a scanner that knows positions, the exception of texts that cannot be read, suggestions for
 * misspelled names, and colours by their names.
 */
@NullMarked
package io.troupe.common.text;

import org.jspecify.annotations.NullMarked;
