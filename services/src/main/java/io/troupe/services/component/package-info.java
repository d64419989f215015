/**
 * What makes a component fit the architecture: its interface (paper, section 2.2, Figure 6).
 *
 * <p>The paper has three layers (section 2.1, Figure 5). Their types here:
 *
 * <ul>
 *   <li><b>Service layer</b>, the collection of service providers: every
 *       {@link io.troupe.services.component.Component}. Those that come with Troupe are in
 *       {@code io.troupe.services.component.kinds}: the Player simulator, the behaviours, the colour finder, and
 *       processes in any language.
 *   <li><b>Communication layer</b>, how services and application talk, by publish and subscribe and by request and
 *       reply: {@code io.troupe.services.bus}, and the {@link io.troupe.services.component.ComponentInterface} by which
 *       each component is on it.
 *   <li><b>Application layer</b>, which discovers, invokes and synchronises services: {@code io.troupe.services.broker}
 *       and {@code io.troupe.services.component.application}.
 * </ul>
 *
 * <p>An interface is three units, each a type: {@link io.troupe.services.component.ComponentCommunication} (CCU) talks
 * with the component, {@link io.troupe.services.component.DataConversion} (DCU) converts and buffers,
 * {@link io.troupe.services.component.BusCommunication} (BCU) talks with the bus.
 */
@NullMarked
package io.troupe.services.component;

import org.jspecify.annotations.NullMarked;
