/**
 * Subsumption: tables of colours, states and services, and the actors that switch between them. Start with
 * {@link io.troupe.services.subsumption.SubsumptionTable} and {@link io.troupe.services.subsumption.SubsumptionRun}.
 */
@NullMarked
package io.troupe.services.subsumption;

import org.jspecify.annotations.NullMarked;
