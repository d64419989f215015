/** Charts and SVG elements shared by the pictures of the commands. */
@NullMarked
package io.troupe.demo.svg;

import org.jspecify.annotations.NullMarked;
