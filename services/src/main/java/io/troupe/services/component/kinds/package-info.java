/**
 * The components of Troupe (the paper's service layer) with their topics, and the catalogue of the kinds of components
 * that application files can name.
 *
 * <p>Components are made by {@link io.troupe.services.component.kinds.PlayerComponent},
 * {@link io.troupe.services.component.kinds.BehaviourComponent},
 * {@link io.troupe.services.component.kinds.ColourFinderComponent} and
 * {@link io.troupe.services.component.kinds.ProcessComponent}. {@link io.troupe.services.component.kinds.RobotTopics}
 * has the topics of a robot.
 */
@NullMarked
package io.troupe.services.component.kinds;

import org.jspecify.annotations.NullMarked;
