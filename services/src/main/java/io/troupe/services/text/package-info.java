/** Words for people: what somebody probably meant. */
@NullMarked
package io.troupe.services.text;

import org.jspecify.annotations.NullMarked;
