/** Control laws as pure functions: readings in, velocity out. */
@NullMarked
package io.troupe.services.behaviour;

import org.jspecify.annotations.NullMarked;
