// SPDX-License-Identifier: MIT
// JSON from other programs: nothing about its content is taken for granted.

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

/** What is wrong with a message, for the person who looks at the file ("'x_m' is not an array"). */
export class Malformed extends Error {}

export function fail(name: string, what: string): never {
  throw new Malformed(`'${name}' ${what}`);
}

export function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

export function parseObject(text: string): JsonObject {
  let value: Json;
  try {
    value = JSON.parse(text) as Json;
  } catch {
    throw new Malformed('is not JSON');
  }
  if (!isObject(value)) throw new Malformed('is not a JSON object');
  return value;
}

// Only the text's own keys: "constructor" is not one of them unless it is written there.
export function member(object: JsonObject, name: string): Json | undefined {
  return Object.hasOwn(object, name) ? object[name] : undefined;
}

export function numberIn(value: Json | undefined, name: string, least: number, most: number): number {
  if (value === undefined) fail(name, 'is missing');
  if (typeof value !== 'number') fail(name, 'is not a number');
  if (!(value >= least && value <= most)) fail(name, 'is out of range');
  return value;
}

export function numberAt(object: JsonObject, name: string, least: number, most: number): number {
  return numberIn(member(object, name), name, least, most);
}

export function wholeAt(object: JsonObject, name: string, least: number, most: number): number {
  const value = numberAt(object, name, least, most);
  if (!Number.isInteger(value)) fail(name, 'is not a whole number');
  return value;
}

export function textAt(object: JsonObject, name: string): string {
  const value = member(object, name);
  if (typeof value !== 'string') fail(name, value === undefined ? 'is missing' : 'is not a text');
  return value;
}

export function arrayAt(object: JsonObject, name: string, length?: number): Json[] {
  const value = member(object, name);
  if (!Array.isArray(value)) fail(name, value === undefined ? 'is missing' : 'is not an array');
  if (length !== undefined && value.length !== length) fail(name, 'has another length than the others');
  return value;
}
