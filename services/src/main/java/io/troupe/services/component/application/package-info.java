/**
 * The application layer (paper, section 2.1.3): an application says which components there are, who needs which
 * service, and when one takes another's place; the broker finds and starts them, and the wiring connects what has the
 * same name.
 */
@NullMarked
package io.troupe.services.component.application;

import org.jspecify.annotations.NullMarked;
