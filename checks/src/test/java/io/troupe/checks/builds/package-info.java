/** Agreement of the Gradle and the Maven build: both are read into the same records, and every difference is named. */
@NullMarked
package io.troupe.checks.builds;

import org.jspecify.annotations.NullMarked;
