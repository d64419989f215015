/**
 * Component interfaces, which connect components with the bus and the broker (paper, section 2.2, Figure 6).
 *
 * <p>The paper has three layers (section 2.1, Figure 5), with these types:
 *
 * <ul>
 *   <li><b>Service layer</b>, the service providers: every {@link io.troupe.services.component.Component}. Those of
 *       Troupe are in {@code io.troupe.services.component.kinds}: the Player simulator, the behaviours, the colour
 *       finder, and processes in any language.
 *   <li><b>Communication layer</b>, through which services and applications exchange messages by publish/subscribe and
 *       request/reply: {@code io.troupe.bus}, and the {@link io.troupe.services.component.ComponentInterface} that
 *       connects each component with the bus.
 *   <li><b>Application layer</b>, which discovers, invokes and synchronises services: {@code io.troupe.broker} and
 *       {@code io.troupe.services.component.application}.
 * </ul>
 *
 * <p>A component interface has three units, each with a type:
 * {@link io.troupe.services.component.ComponentCommunication} (CCU) communicates with the component,
 * {@link io.troupe.services.component.DataConversion} (DCU) converts and buffers,
 * {@link io.troupe.services.component.BusCommunication} (BCU) communicates with the bus.
 */
@NullMarked
package io.troupe.services.component;

import org.jspecify.annotations.NullMarked;
