/**
 * The components that come with Troupe (the paper's service layer), each with what it says and hears on the bus, and
 * the catalogue by which a declaration names them.
 */
@NullMarked
package io.troupe.services.component.kinds;

import org.jspecify.annotations.NullMarked;
