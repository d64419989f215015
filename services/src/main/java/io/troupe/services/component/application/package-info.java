/**
 * The application layer (paper, section 2.1.3). An application declares its components, which services they need, and
 * when a component replaces another. The broker finds and starts the components, and the application connects the
 * topics of users and providers that have the same name.
 */
@NullMarked
package io.troupe.services.component.application;

import org.jspecify.annotations.NullMarked;
