/** The code that the paper prints, Figures 7, 14, 17 and 20, as programs. */
@NullMarked
package io.troupe.paper;

import org.jspecify.annotations.NullMarked;
