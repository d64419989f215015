/** Component interfaces: what makes a component fit the architecture (CCU, DCU, BCU), and applications wired from them. */
@NullMarked
package io.troupe.services.component;

import org.jspecify.annotations.NullMarked;
