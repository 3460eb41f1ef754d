// SPDX-License-Identifier: MIT
import './style.css';
import { App } from './app';

const root = document.getElementById('app');
if (root) {
  const app = new App(root);
  Object.assign(window, { banyan: app }); // to script the page from the browser's console
  void app.begin();
}
