/** Models of behaviour, interaction and priority (BIP): atoms, connectors, their states, their text and their net. */
@NullMarked
package io.troupe.petri.bip;

import org.jspecify.annotations.NullMarked;
