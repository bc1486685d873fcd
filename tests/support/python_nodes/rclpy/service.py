# SPDX-License-Identifier: Apache-2.0
class Service:
    def __init__(self, service_impl, srv_type, srv_name, callback, callback_group, qos_profile):
        self.__service = service_impl
        self.callback = callback

    @property
    def handle(self):
        return self.__service
