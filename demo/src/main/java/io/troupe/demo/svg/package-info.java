/** Charts, shared by the figures of the commands. */
@NullMarked
package io.troupe.demo.svg;

import org.jspecify.annotations.NullMarked;
