/** Reading and writing of text: positions in a text, and suggestions for misspelled names. */
@NullMarked
package io.troupe.common.text;

import org.jspecify.annotations.NullMarked;
