/** Who drives which robot: colours, states, and the actors that switch services. */
@NullMarked
package io.troupe.services.subsumption;

import org.jspecify.annotations.NullMarked;
